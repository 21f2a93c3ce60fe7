#error "The component 'executor' is not selected: add `components: [+executor]` to microros.yaml and generate again"
