#error "The component 'parameters' is not selected: add `components: [+parameters]` to microros.yaml and generate again"
